// Runs the page of `lom explain -o PAGE.html` with a document that has only what the page asks of one: every step forth and
// back, every button. Prints how many steps it has; an exception is a failure.
const fs=require('fs'),html=fs.readFileSync(process.argv[2],'utf8');
const grab=(id)=>{const m=html.match(new RegExp('<script[^>]*id="'+id+'">([\\s\\S]*?)</script>'));return m?m[1]:''};
const made={};
function el(tag){return {tag,children:[],className:'',textContent:'',classList:{toggle(){}},append(...c){this.children.push(...c)},scrollIntoView(){},insertRow(){const r=el('tr');this.children.push(r);r.insertCell=()=>{const c=el('td');r.children.push(c);return c};return r},getContext(){return new Proxy({},{get:(t,k)=>k in t?t[k]:()=>{},set:(t,k,v)=>{t[k]=v;return true}})},getBoundingClientRect(){return{left:0,top:0,width:960,height:640}},width:960,height:640}}
global.document={getElementById(id){if(!made[id]){made[id]=el(id);made[id].textContent=grab(id)}return made[id]},createElement:el,title:''};
global.Image=class{set src(v){this._s=v;if(!v.startsWith('data:image/png;base64,'))throw Error('no picture');this.onload()}};
const scripts=[...html.matchAll(/<script>\n([\s\S]*?)<\/script>/g)];
eval(scripts[scripts.length-1][1]);
const steps=made.steps.children.length;
for(let i=0;i<steps+2;i++)made.next.onclick();
for(let i=0;i<steps+2;i++)made.back.onclick();
made['in'].onclick();made.out.onclick();made.all.onclick();made.here.onclick();
console.log(document.title, steps, made.verdict.textContent.slice(0,80), made.numbers.children.length);
