// Runs the page of `lom steps` with a document that has only what the page asks of one: every step forth and back, by
// buttons, slider, list, keys and swipes. Prints how many steps it has; an exception is a failure.
const fs=require('fs'),path=require('path'),page=process.argv[2],html=fs.readFileSync(page,'utf8');
const data=html.match(/<script[^>]*id="data">([\s\S]*?)<\/script>/)[1],made={};
const el=tag=>({tag,children:[],style:{},textContent:'',value:'',append(...c){this.children.push(...c)},clientWidth:100,naturalWidth:50});
global.document={getElementById(id){if(!made[id]){made[id]=el(id);if(id=='data')made[id].textContent=data}return made[id]},createElement:el,title:''};
global.Image=class{};global.location={hash:'#2'};global.history={replaceState(a,b,to){location.hash=to}};global.window={};
const scripts=[...html.matchAll(/<script>\n([\s\S]*?)<\/script>/g)];
(0,eval)(scripts[scripts.length-1][1].replace('const data','var data').replace('let at','var at'));
const steps=JSON.parse(data).steps,want=(a,b)=>{if(a!==b)throw Error(a+' instead of '+b)};
for(const s of steps)if(!fs.existsSync(path.join(path.dirname(page),s.file)))throw Error('no '+s.file);
want(made.picture.src,steps[1].file);
made.back.onclick();made.back.onclick();want(made.picture.src,steps[0].file);
for(let i=0;i<steps.length+2;i++)made.next.onclick();
want(made.picture.src,steps[steps.length-1].file);want(made.number.textContent,steps.length+' / '+steps.length);
const key=k=>document.onkeydown({key:k,preventDefault(){},target:null});
key('Home');key('ArrowRight');key('ArrowRight');key('ArrowLeft');want(made.picture.src,steps[1].file);
made.slider.value='3';made.slider.oninput();want(made.picture.src,steps[2].file);
made.stage.onpointerdown({clientX:200});made.stage.onpointerup({clientX:100});want(made.picture.src,steps[3].file);
made.list.value='1';made.list.onchange();want(location.hash,'#1');
made.picture.onload();want(made.picture.style.imageRendering,'pixelated');
console.log('steps: '+steps.length);
